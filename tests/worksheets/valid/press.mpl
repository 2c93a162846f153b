# A toggle press: positions by fsolve, printed by formats, and an animation.
restart: with(MBSymba_r6): with(plots): with(plottools):
r := 0.1: a := 0.4: b := 0.3: d := 0.35:
T1 := rotate('Z', theta):
A := make_POINT(T1, r, 0, 0):
B := make_POINT(ground, d + b*cos(phi), b*sin(phi), 0):
rod := join_points(A, B):
loop := dot_prod(rod, rod) - a^2:
ram := 2*b*sin(phi):
for k from 0 to 3 do
  alpha := evalf(k*Pi/2);
  phi__k := fsolve(subs(theta = alpha, loop), phi = 0..3);
  printf("%+07.3f %07.4f\n", alpha, evalf(subs(phi = phi__k, ram)));
  frame[k] := display([line([0,0], [r*cos(alpha), r*sin(alpha)]), line([d,0], [d + b*cos(phi__k), b*sin(phi__k)])]);
end do:
display([seq(frame[k], k = 0..3)], insequence = true);
