# A name that gets its value later changes all that was built with it; entries of remember tables take effect in frames.
restart: with(MBSymba_r6):
T := rotate('Z', q) * translate(a, 0, 0):
P := origin(T):
a := w - b:
comp_XYZ(P, ground);
x(t) := V*t:
S := translate(x(t), y(t), 0):
comp_XYZ(velocity(origin(S)));
for n from 0 to 2 do q := n*Pi/2; comp_X(P, ground); end do;
T2 := subs(b=0, T): comp_X(origin(T2), ground);
