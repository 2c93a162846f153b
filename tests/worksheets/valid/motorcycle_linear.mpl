# A motorcycle that leans and yaws little: frames to first order, energies to second.
restart: with(MBSymba_r4):
linear_modeling({y(t), psi(t), phi(t), epsilon});
x(t) := V*t:
TR := translate(x(t), y(t), 0) * rotate('Z', psi(t));
TC := TR * rotate('X', phi(t)) * rotate('Y', epsilon);
G := make_POINT(TC, b, 0, -h):
chassis := make_BODY(G, m, I__x, I__y, I__z, 0, I__xz, 0):
_gravity := make_VECTOR(ground, 0, 0, g):
K := kinetic_energy(chassis);
U := gravitational_energy(chassis);
eqy := lagrange(K-U, y(t), t);
eqphi := lagrange(K-U, phi(t), t);
eqN := newton_equations({chassis}, ground):
Comps(eqN);
linearize(sin(phi(t))*cos(psi(t)) + phi(t)^2 + a);
