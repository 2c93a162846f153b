# A car of 19 bodies on a moving master frame: procedures, anti-bodies, tables; saved for a second sheet.
restart: with(MBSymba_r6): with(MBSymba_r6_tire):
PDEtools[declare]({x(t), y(t)}, prime=t, quiet):
anti_body := proc(BB::BODY)
  description "what is taken away";
  local AB;
  AB := copy(BB);
  AB[mass] := -BB[mass]; AB[inertia] := -BB[inertia];
  return AB;
end proc:
arm := proc(T, {m := 0, l := 0}) make_BODY(make_POINT(T, 0, l/2, 0), m, m*l^2/12, 0, m*l^2/12) end proc:
track_XY := use_moving_frame(u(t), v(t), 0, 0, 0, Omega(t), translate(x(t), y(t), 0) . rotate('Z', psi(t))):
_gravity := make_VECTOR(ground, 0, 0, g):
T__c := Translate(0, 0, -h - z(t)) . Rotate('Y', mu(t)) . Rotate('X', phi(t)):
set_frame_name(T__c, 'T__c'):
chassis := make_BODY(T__c, M, I__x, I__y, I__z, 0, I__xz, 0): show(chassis);
engine := make_BODY(make_POINT(T__c, a, 0, b), m__e, J, J, J):
room := anti_body(make_BODY(make_POINT(T__c, a, 0, b), m__o, J__o, J__o, J__o)):
px := [a__f, a__f, -a__r, -a__r]: py := [-w, w, -w, w]: steer := [delta(t), delta(t), 0, 0]:
for i from 1 to 4 do
  T__h[i] := Translate(px[i], py[i], -R) . Rotate('Z', steer[i]):
  upright[i] := make_BODY(T__h[i], m__u):
  wheel[i] := make_BODY(T__h[i] . Rotate('Y', -theta[i](t)), m__w, I__d, I__a, I__d):
  upper[i] := arm(T__h[i], m = m__a, l = l__a): lower[i] := arm(T__h[i], m = 2*m__a, l = l__a):
  tire[i] := make_TIRE(wheel[i], 0, 0, 0, 0, R, X[i](t), Y[i](t), -N[i](t), 0, 0, 0, master_frame):
  (F[i], TT[i]) := tire_forces(tire[i]):
  CP[i], VS[i], VN[i], VR[i] := tire_kinematics(tire[i]):
  S[i] := make_FORCE(make_VECTOR(master_frame, 0, 0, -Fs[i](t)), origin(T__h[i]), chassis, upright[i]):
od:
car := {chassis, engine, room, seq(op([upright[i], wheel[i], upper[i], lower[i]]), i = 1..4)}:
nops(car);
forces := {seq(F[i], i = 1..4), seq(TT[i], i = 1..4), seq(S[i], i = 1..4)}:
eqnsN := newton_equations(car union forces):
eqnsE := euler_equations(car union forces, origin(master_frame)):
eqns := [comp_XYZ(eqnsN), comp_XYZ(eqnsE)]:
spin := [seq(comp_Y(euler_equations({wheel[i], F[i], TT[i]}, origin(T__h[i])), T__h[i]), i = 1..4)]:
slips := [seq(1 + VR[i]/VS[i], i = 1..4)]:
has(eqns[1], X[1](t)), has(eqns[1], N[1](t)), has(eqns, [delta(t), zz(t)]);
save eqns, spin, slips, chassis, "car_equations.mpl":
