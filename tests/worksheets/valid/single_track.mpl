# A single-track vehicle on a moving master frame: tracking equations, equations of motion, and a linear model.
restart: with(MBSymba_r6):
track_XY := use_moving_frame(V, v(t), 0, 0, 0, r(t), translate(x(t),y(t),0) * rotate('Z', psi(t)));
rates := solve({op(track_XY)}, diff([x(t), y(t), psi(t)], t));
car := make_BODY(master_frame, m, 0, 0, I__z):
show(car);
front := make_POINT(moving_frame, a, 0, 0):
rear := make_POINT(moving_frame, -b, 0, 0):
T__s := translate(a,0,0) * rotate('Z', delta(t)):
F__f := make_FORCE(make_VECTOR(T__s, 0, Y__f, 0), front, car):
F__r := make_FORCE(make_VECTOR(moving_frame, 0, Y__r, 0), rear, car):
eqN := newton_equations({car, F__f, F__r}):
eqE := euler_equations({car, F__f, F__r}, CoM(car)):
V__f := velocity(front):
lambda__f := arctan(comp_Y(V__f, T__s) / comp_X(V__f, T__s)):
slip := linearize(lambda__f, {v(t), r(t), delta(t)});
lambda__r := linearize(arctan(comp_Y(velocity(rear))/comp_X(velocity(rear))), {v(t), r(t)});
eqns := subs(Y__f = -C__f*slip, Y__r = -C__r*lambda__r, linearize([comp_Y(eqN), comp_Z(eqE)], {v(t), r(t), delta(t)})):
xx := [v(t), r(t)]: uu := [delta(t)]:
AA, BB := state_space(linearize(eqns, {v(t), r(t), delta(t)}), t, xx, uu);
