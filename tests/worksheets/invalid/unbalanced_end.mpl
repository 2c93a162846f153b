for i from 1 to 3 do x := i;
y := 2;
