s := solve(x = cos(x)*a, x);
y := 2;
