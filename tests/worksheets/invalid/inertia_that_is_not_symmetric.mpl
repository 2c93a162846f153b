with(MBSymba_r6):
B := make_BODY(ground, m, Matrix(3,3,[[1,2,3],[4,5,6],[7,8,9]])):
K := kinetic_energy(B);
y := 2;
