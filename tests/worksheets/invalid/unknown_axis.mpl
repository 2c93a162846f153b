with(MBSymba_r6):
T := rotate('W', q(t));
y := 2;
