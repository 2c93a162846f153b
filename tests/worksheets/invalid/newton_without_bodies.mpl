with(MBSymba_r6):
v := make_VECTOR(ground, 1, 0, 0):
N := newton_equations({});
y := 2;
