with(MBSymba_r6):
P := make_POINT(ground, 1, 2);
y := 2;
