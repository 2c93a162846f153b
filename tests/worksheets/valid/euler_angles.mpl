# Rates of Euler angles by the components of the angular velocity in the axes of the body.
restart: with(MBSymba_r6):
PDEtools[declare]({psi(t), theta(t), phi(t)}, prime = t, quiet):
T := rotate('Z', psi(t)) * rotate('X', theta(t)) * rotate('Z', phi(t)):
W := angular_velocity(T):
eqns := {comp_X(W) = omega__x(t), comp_Y(W) = omega__y(t), comp_Z(W) = omega__z(t)}:
rates := solve(eqns, {diff(psi(t),t), diff(theta(t),t), diff(phi(t),t)});
W2 := simplify(inv_frame(T) . map(diff, T, t)):
simplify(W2[3,2] - comp_X(W)), simplify(W2[1,3] - comp_Y(W)), simplify(W2[2,1] - comp_Z(W));
