# A tyre by hand, and with the add-on.
restart: with(MBSymba_r6): with(MBSymba_r6_tire):
use_moving_frame(u(t), v(t), 0, 0, 0, omega(t)):
hub := translate(a, 0, -h(t)) * rotate('Z', delta(t)) * rotate('X', phi(t)):
wheel := make_BODY(hub * rotate('Y', theta(t)), m__w, J__d, J__a, J__d):
tire := make_TIRE(wheel, 0, 0, 0, 0, rr(t), X, Y, -N, 0, M__y, M__z, moving_frame):
show(tire):
tire['angles'];
camber := rhs(tire['angles'][2]);
(F, M) := tire_forces(tire):
show(F): show(M):
(CP, VS, VN, VR) := tire_kinematics(tire):
show(CP, 'synthetic');
kappa := 1 + VR/VS: lambda := arctan(-VN/VS):
C := make_POINT(hub, 0, 0, rr(t)):
VC := frame_frozen_velocity(C, hub):
simplify(comp_X(VC, translate(0,0,0)*rotate('Z', delta(t))) - VS);
