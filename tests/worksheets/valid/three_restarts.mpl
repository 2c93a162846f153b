# Three sheets in one file: each restart forgets all, modes too.
restart: with(MBSymba_r6):
use_moving_frame(u(t), 0, 0, 0, 0, r(t)): a := 3:
comp_XYZ(velocity(make_POINT(ground, 0, b, 0)));
restart: with(MBSymba_r6):
linear_modeling({q(t)}): T := rotate('Z', q(t)): T[1,1], a;
restart: with(MBSymba_r6):
T := rotate('Z', q(t)): T[1,1], show(origin(T), 'synthetic');
comp_XYZ(velocity(make_POINT(ground, x(t), b, 0)));
