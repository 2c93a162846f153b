s := dsolve({diff(x(t),t) = k*x(t), x(0) = 1}, numeric);
y := 2;
