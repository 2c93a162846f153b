with(MBSymba_r6):
P := origin(ground) + origin(ground);
y := 2;
