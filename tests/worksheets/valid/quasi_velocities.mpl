# A disc that rolls: the rates of its coordinates by quasi-velocities.
restart: with(MBSymba_r6):
T := translate(x(t), y(t), 0) * rotate('Z', psi(t)) * rotate('X', phi(t)):
W := angular_velocity(T):
relations := [comp_X(W) = u1(t), comp_Y(W) = u2(t), comp_Z(W) = u3(t)]:
rates := solve({relations[1], relations[3]}, {diff(phi(t),t), diff(psi(t),t)});
disc := make_BODY(T, m, J, 2*J, J):
K2 := simplify(kinetic_energy(disc), {diff(phi(t),t) = u1(t), diff(psi(t),t)*cos(phi(t)) = u3(t)}, [diff(phi(t),t), diff(psi(t),t)]);
`diff/phi` := proc(t) u1(t) end proc:
`diff/psi` := proc(t) u3(t)/cos(phi(t)) end proc:
diff(phi(t), t), diff(cos(psi(t)), t);
K := kinetic_energy(disc):
V := velocity(CoM(disc)):
A := acceleration(make_POINT(T, 0, a, 0)):
comp_Z(A);
