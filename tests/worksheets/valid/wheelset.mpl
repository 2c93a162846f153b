# Railway wheelset: hunting. mass/creep. (worksheet kept since 2008, r5.1 -> r6)
restart: with(MBSymba_r6): with(LinearAlgebra):
# linear model
linear_modeling({y(t),psi(t),phi(t),chi(t)}):
phi(t) := -sigma*y(t):
TW := Translate(V*t,y(t),r0) * Rotate('Z',psi(t)) * Rotate('X',phi(t)):
ws := make_BODY(TW*Rotate('Y',V/r0*t+chi(t)),m,Ix,Iy,Ix):
# contact points: left and right, conicity lambda0
rL := r0 + lambda0*y(t): rR := r0 - lambda0*y(t):
CL := make_POINT(TW,0, b,-rL):
CR := make_POINT(TW,0,-b,-rR):
# creepages by hand
omega := V/r0:
xiL := linearize((V - rL*omega - b*diff(psi(t),t))/V);
xiR := linearize((V - rR*omega + b*diff(psi(t),t))/V);
eta := linearize(diff(y(t),t)/V - psi(t));
FL := make_FORCE(make_VECTOR(TW,-f11*xiL,-f22*eta,0),CL,ws):
FR := make_FORCE(make_VECTOR(TW,-f11*xiR,-f22*eta,0),CR,ws):
K := make_FORCE(make_VECTOR(ground,0,-ky*y(t),0),CoM(ws),ws):
KT := make_TORQUE(make_VECTOR(ground,0,0,-kpsi*psi(t)),ws):
NE := newton_equations({ws,FL,FR,K}):
EE := euler_equations({ws,FL,FR,K,KT},CoM(ws)):
e1 := comp_Y(NE,ground);
e2 := comp_Z(project(EE,TW));
e2 := linearize(e2):
x, eqs := first_order([e1,e2],[y(t),psi(t)],t);
A,B := state_space(eqs,t,x,[]):
A;
cp := CharacteristicPolynomial(A,s):
rt := subs(m=1200,Ix=700,Iy=100,r0=0.45,b=0.75,lambda0=0.1,sigma=0.05,f11=1e7,f22=1e7,ky=2e5,kpsi=1e6,V=30.,cp):
fsolve(rt,s,complex);
# critical speed: real part changes sign
re := v -> max(op(map(Re,[fsolve(subs(m=1200,Ix=700,Iy=100,r0=0.45,b=0.75,lambda0=0.1,sigma=0.05,f11=1e7,f22=1e7,ky=2e5,kpsi=1e6,V=v,cp),s,complex)]))):
for v from 20 by 20 to 80 do printf("%5.0f km/h  %10.4f\n",v*3.6,re(v)) od;
