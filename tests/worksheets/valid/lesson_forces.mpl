# Forces and torques of a pendulum, and of cranks made in a loop, in the words of release 6.
restart: libname := libname, "C:/MBSymba": with(MBSymba_r6): with(LinearAlgebra):
PDEtools[declare](theta(t), prime=t):
Describe(make_BODY);
T1 := rotate('Z',theta(t)) . translate(l, 0, 0):
set_frame_name(T1, 'T__1');
pendulum := make_BODY(T1, m, 0, 0, J):
show(pendulum[frame]);
_gravity := make_VECTOR(ground, 0, -g, 0):
O := make_POINT(ground, 0,0,0):
RF := make_FORCE(make_VECTOR(ground, Rx(t), Ry(t), 0), O, pendulum):
DT := make_TORQUE(make_VECTOR(ground, 0, 0, -c*diff(theta(t),t)), pendulum):
sys := {pendulum, RF, DT};
eqN := newton_equations(sys): eqE := euler_equations(sys, O):
eqns := [comp_X(eqN) = 0, comp_Y(eqN) = 0, comp_Z(eqE) = 0]:
sol := solve(eqns, [Rx(t), Ry(t), diff(theta(t),t,t)]):
acc := simplify(subs(sol[1], diff(theta(t),t,t)));
'G' = show(project(CoM(pendulum), ground));
V := velocity(CoM(pendulum), 'absolute'): VR := project(V, T1): VR[comps] := simplify(VR[comps]): show(VR);
W := simplify(inv_frame(T1) . map(diff, T1, t)): W[1..3,1..3];
R := T1[1..3,1..3]: simplify(R . Transpose(R));
A := Matrix(3,3,[[a,0,0],[0,b,0],[0,0,c]]):
pendulum[inertia] := A . A: pendulum[inertia];
B2 := copy(pendulum): B2[mass] := 2*m: B2[frame] := ground: show(B2);
for n from 1 to 3 do crank||n := make_BODY(rotate('Z', q||n(t)) * translate(r,0,0), m||n): end do:
K := kinetic_energy({seq(crank||n, n=1..3)});
L := K + sum('lambda||k(t)'*(q||k(t)-q1(t)), 'k'=2..3);
eqL := [seq(lagrange(L, q||i(t), t), i=1..3)];
F12 := make_FORCE(ground, k*(q1(t)-q2(t)), 0,0, origin(crank2[frame]), crank1, crank2):
M12 := make_TORQUE(ground, 0, 0, tau, crank1, crank2):
internal := newton_equations({crank1, crank2, F12, M12}): has([comp_XYZ(internal)], k);
Q := generalized_force({F12, M12}, [q1(t), q2(t)]);
power(DT);
phi := make_CONSTRAINT([comp_X(CoM(crank1), ground) - comp_X(CoM(crank2), ground)]): show(phi);
comp_XYZ(uvec_Y(T1), ground), comp_XYZ(cross_prod(join_points(O, CoM(pendulum)), RF), ground);
