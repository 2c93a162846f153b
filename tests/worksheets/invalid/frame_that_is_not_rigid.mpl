with(MBSymba_r6):
V := velocity(origin(Matrix([[2,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]])));
y := 2;
