# An inverted slider-crank: an angle and a length from one loop.
restart: with(MBSymba_r6):
T1 := rotate('Z', theta(t)): A := make_POINT(T1, r, 0, 0):
T2 := translate(-d, 0, 0) * rotate('Z', psi(t)): B := make_POINT(T2, s(t), 0, 0):
gap := join_points(B, A):
loop := comp_XYZ(gap, ground):
sol := allvalues(solve({loop[1], loop[2]}, {psi(t), s(t)})):
length__1 := simplify(subs(sol[1], s(t)));
angle__1 := subs(sol[1], psi(t)):
check := evalf(subs(r=0.5, d=2, theta(t)=0.8, [length__1, angle__1]));
