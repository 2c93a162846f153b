# A conic pendulum: its steady motion by a solve, and its momenta.
restart: with(MBSymba_r6):
PDEtools[declare](alpha(t), prime=t, quiet):
T := rotate('Z', alpha(t)) * rotate('Y', -theta) * translate(0, 0, -l):
bob := make_BODY(T, m):
_gravity := make_VECTOR(ground, 0, 0, -g):
O := origin(ground):
p := linear_momentum(bob): comp_XYZ(p, rotate('Z', alpha(t)));
H := angular_momentum(bob, O): comp_Z(H, ground);
rod := make_FORCE(T, 0, 0, S, origin(T), bob):
N := project(newton_equations({bob, rod}), rotate('Z', alpha(t))):
S0 := solve(comp_Z(N), S);
cond := simplify(subs(S = S0, diff(alpha(t),t) = Omega, comp_X(N))):
simplify(subs(Omega = sqrt(g/(l*cos(theta))), cond));
