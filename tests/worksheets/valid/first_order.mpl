# Equations of first order, and the matrices of a linear model.
restart: with(MBSymba_r6):
eqns := [m*diff(x(t),t,t) + c*diff(x(t),t) + k*(x(t) - y(t)) - F(t), m*diff(y(t),t,t) + k*(y(t) - x(t))]:
xx, eqns1 := first_order(eqns, [x(t), y(t)], t);
AA, BB := state_space(eqns1, t, xx, [F(t)]);
nops(eqns1), AA[3,1], BB[3,1];
