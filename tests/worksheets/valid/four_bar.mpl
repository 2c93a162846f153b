# A four-bar linkage: the closure of its loop in closed form, then velocities.
restart: with(MBSymba_r6):
T1 := rotate('Z', theta(t)):
crank := make_VECTOR(T1, r, 0, 0):
T2 := rotate('Z', phi(t)):
rod := make_VECTOR(T2, l, 0, 0):
T3 := rotate('Z', psi(t)):
`rocker arm` := make_VECTOR(T3, b, 0, 0):
base := make_VECTOR(ground, d, 0, 0):
closure := project(crank, ground) + rod - `rocker arm` - base:
phi__loop := [comp_X(closure), comp_Y(closure)];
sol := [allvalues(solve({op(phi__loop)}, {phi(t), psi(t)}))]:
nops(sol);
data := [r=0.7, l=2.2, b=2.1, d=2.5, theta(t)=0.9]:
evalf(subs(op(data), subs(sol[1], phi__loop)));
vel := diff(phi__loop, t):
solve({op(vel)}, {diff(phi(t),t), diff(psi(t),t)});
tau := subs(%, diff(psi(t),t)/diff(theta(t),t)):
