# A wheel that corners: contact by hand, slip and camber, with alias and plain functions.
restart: with(MBSymba_r4):
alias(c = cos, s = sin):
T := translate(x(t), y(t), R) * rotate('Z', psi(t)) * rotate('X', phi(t)):
G := origin(T): v := uvec_Z(T): rho := -R:
C := G + rho*v:
Comps(project(C, ground));
VC := frame_frozen_velocity(C, T * rotate('Y', theta(t))):
n := make_VECTOR(ground, 0, 0, 1):
e := cross_prod(uvec_Y(T), n): show(e):
VS := dot_prod(velocity(C), uvec_X(T)):
VR := simplify(dot_prod(VC, uvec_X(T)) - dot_prod(frame_frozen_velocity(C, T), uvec_X(T)));
kappa := 1 + VR/VS: lambda := arctan(-dot_prod(VC, e)/VS):
has(VR, theta(t)), has(VR, diff(theta(t), t));
