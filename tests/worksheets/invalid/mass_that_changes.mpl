with(MBSymba_r6):
B := make_BODY(ground, m(t)):
K := kinetic_energy(B);
y := 2;
