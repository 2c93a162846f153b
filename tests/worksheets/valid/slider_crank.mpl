# A slider-crank by solve, and the force on the piston by the equations of its bodies.
restart: with(MBSymba_r6):
T__1 := Rotate('Z', theta(t)):
T__2 := T__1 . Translate(r, 0, 0) . Rotate('Z', phi(t)-theta(t)):
P := make_POINT(T__2, l, 0, 0):
loop := {comp_Y(P, ground) = 0, comp_X(P, ground) = s(t)};
sol := allvalues(solve(loop, {phi(t), s(t)})):
first := sol[1]:
s__1 := subs(first, s(t));
crank := make_BODY(T__1, m__1, 0, 0, I__1):
rod := make_BODY(make_POINT(T__2, a, 0, 0), m__2, 0, 0, I__2):
piston := make_BODY(translate(s(t), 0, 0), m__3):
bodies := {crank, rod, piston}:
K := kinetic_energy(bodies):
gas := make_FORCE(make_VECTOR(ground, -p, 0, 0), CoM(piston), piston):
W := generalized_force(gas, [theta(t), phi(t), s(t)]);
power(gas);
