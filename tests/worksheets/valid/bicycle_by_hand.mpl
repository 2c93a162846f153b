# Whipple-like bicycle, point masses; my own version for the course  (release 6)
restart; with(MBSymba_r6);
PDEtools[declare](prime = t, quiet);
## ------- frames -----------
use_moving_frame(V(t),v(t),0, 0,0,Omega(t)):
Troll := moving_frame . Rotate('X',phi(t)):
Tfork := Troll . Translate(w,0,0) . Rotate('Y',epsilon) . Rotate('Z',delta(t)) :
set_frame_name(Troll,'T__R'): set_frame_name(Tfork,'T__F'):
## ------- bodies -----------
rear  := make_BODY(make_POINT(Troll,b,0,-h), M, I__xx,I__yy,I__zz,0,-I__xz,0):
front := make_BODY(make_POINT(Tfork,e,0,-f), m, J__xx,0,J__zz):
_gravity := make_VECTOR(moving_frame,0,0,g):
## ------- forces ------------
CR := make_POINT(moving_frame,0,0,0):
CF := make_POINT(moving_frame,w,0,0):
FR := make_FORCE(moving_frame, X__r,Y__r(t),-N__r, CR, rear):
FF := make_FORCE(moving_frame, 0,Y__f(t),-N__f, CF, front):
tau := make_TORQUE(make_VECTOR(Tfork,0,0,T__delta), front, rear):
bike := {rear,front,FR,FF,tau}:
NE := newton_equations(bike):
EE := euler_equations(bike, CR):
eqns := [comp_XYZ(NE,moving_frame), comp_XYZ(EE,moving_frame)]:
nops(eqns);
## straight running
SR := {V(t)=V, v(t)=0, Omega(t)=0, phi(t)=0, delta(t)=0, Y__r(t)=0, Y__f(t)=0};
trim := simplify(eval(subs(SR, eqns)));
sol := solve({trim[1],trim[3],trim[5]}, {X__r,N__r,N__f});
assign(sol);
N__f + N__r;
simplify(%);
unassign('X__r','N__r','N__f');
## linear
vars := [v(t),Omega(t),phi(t),delta(t),Y__r(t),Y__f(t)]:
lin := proc(e,L) local eps, i, r;
  r := subs(V(t)=V,e);
  r := subs([seq(L[i]=eps*L[i],i=1..nops(L))], r);
  r := eval(diff(r,eps),eps=0);
  simplify(r)
end proc:
lateral := map(lin, [eqns[2],eqns[4],eqns[6]], vars):
K__phi := coeff(lateral[2],phi(t));
M__phi := coeff(lateral[2],diff(phi(t),t,t));
lateral[1];
