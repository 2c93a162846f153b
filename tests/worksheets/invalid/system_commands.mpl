ssystem("ls");
y := 2;
