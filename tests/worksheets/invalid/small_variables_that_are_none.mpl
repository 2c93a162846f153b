with(MBSymba_r6):
linear_modeling({x(t)^2});
y := 2;
