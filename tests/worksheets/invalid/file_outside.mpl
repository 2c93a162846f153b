save y, "../outside.txt";
y := 2;
