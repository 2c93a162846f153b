with(MBSymba_r6):
A, B := state_space([diff(x(t),t) - y(t)], t, [x(t), y(t)], []);
y := 2;
