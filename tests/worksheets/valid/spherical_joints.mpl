# A double pendulum in a plane with the forces in its joints.
restart: with(MBSymba_r6):
_gravity := make_VECTOR(ground, 0, -g, 0):
T1 := rotate('Z', theta1(t)): T2 := translate(x2(t), y2(t), 0) * rotate('Z', theta2(t)):
link1 := make_BODY(make_POINT(T1, l/2, 0, 0), m, 0, 0, J):
link2 := make_BODY(T2, m, 0, 0, J):
FzA(t) := 0: FzB(t) := 0:
base := make_BODY(ground, 0):
phiA, RA, SA := spherical_JOINT(make_POINT(T1, 0,0,0), origin(ground), link1, base, "A"):
phiB, RB, SB := spherical_JOINT(make_POINT(T1, l,0,0), make_POINT(T2, -l/2,0,0), link1, link2, "B"):
show(phiB); show(RB); show(SB);
forces := {RA, RB, SB}:
N2 := newton_equations({link2} union forces):
comp_XYZ(N2);
E1 := euler_equations({link1} union forces, CoM(link1)):
comp_Z(E1);
eqnsL := lagrange_equations({link1, link2, RB, SB}, [theta1(t), theta2(t)]):
