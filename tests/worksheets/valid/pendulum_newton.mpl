# A pendulum by Newton's and Euler's equations, with the force in its pin.
restart: with(MBSymba_r6):
PDEtools[declare](theta(t), prime=t, quiet):
_gravity := make_VECTOR(ground, 0, -g, 0):
T1 := rotate('Z', theta(t)):
G := make_POINT(T1, 0, -l, 0):
bob := make_BODY(G, m, 0, 0, I__z):
show(bob, 'synthetic');
O := origin(ground):
pin := make_FORCE(ground, X(t), Y(t), 0, O, bob):
eqnsN := newton_equations({bob, pin}):
eqnsE := euler_equations({bob, pin}, O):
eq := simplify(comp_Z(eqnsE));
R := solve({comp_X(eqnsN), comp_Y(eqnsN)}, {X(t), Y(t)});
T := kinetic_energy(bob); V := gravitational_energy(bob);
eqL := lagrange(T - V, theta(t), t);
simplify(eqL - eq);
