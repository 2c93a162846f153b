T1 := Matrix(4, 4, [[cos(q(t)),-sin(q(t)),0,0],[sin(q(t)),cos(
q(t)),0,0],[0,0,1,0],[0,0,0,1]], attributes =
[`T__1`]);
P := table([(coords)=(Matrix(4, 1, [[l],[0],[0],[1]])),(frame)=(Matrix(4, 4, [[cos(q(t
)),-sin(q(t)),0,0],[sin(q(t)),cos(q(t)),0,0],[0,0,1,0],[0,0,0,1]])),(obj)=POINT]);
data := {m = 2.5, g = 9.81, a_long_\
name = .5e-1};
twice := proc (x) local y; y := 2*x; return y end proc;
A[1] := 3; A[2] := x+
y;
twice(A[1])+A[2];
subs(data, m*g);
comp_X(velocity(P));
