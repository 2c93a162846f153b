with(MBSymba_r6):
P := origin(ground):
F := make_FORCE(ground, 1, 0, 0, P, P);
y := 2;
