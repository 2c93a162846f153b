## satellite with two reaction wheels and solar panel, quasi-velocities, by hand
restart:
with(MBSymba_r6,make_BODY,make_VECTOR,make_TORQUE,rotate,translate,angular_velocity,kinetic_energy,comp_XYZ,project,show,ground):
`diff/wx` := proc(u,x) wxd(u)*diff(u,x) end proc:
T := rotate('Z',psi(t))*rotate('Y',theta(t))*rotate('X',phi(t)):
W := [comp_XYZ(angular_velocity(T))]:
# speeds
quasi := {W[1]=p(t),W[2]=q(t),W[3]=r(t)}:
rates := solve(quasi,{diff(psi(t),t),diff(theta(t),t),diff(phi(t),t)});
rates := map(simplify,rates);
sat := make_BODY(T,M,Ix,Iy,Iz):
K := kinetic_energy(sat):
K := simplify(subs(rates,K));
# wheels
wh := a -> make_BODY(T*rotate(a,`if`(a='X',a1(t),a2(t))),mw,`if`(a='X',Js,Jt),`if`(a='Y',Js,Jt),Jt):
KW := simplify(subs(rates,kinetic_energy({wh('X'),wh('Y')})));
h := [diff(K+KW,p(t)),diff(K+KW,q(t)),diff(K+KW,r(t))]:
w := [p(t),q(t),r(t)]:
E := [seq(diff(h[i],t),i=1..3)]:
gy := convert(linalg[crossprod](w,h),list):
eqs := zip((a,b)->a+b,E,gy):
eqs := map(collect,eqs,[Ix,Iy,Iz,Js,Jt]);
wx(2*s): diff(%,s);
eq0 := subs(a1(t)=0,a2(t)=0,eqs): eq0 := eval(eq0):
simplify(eq0[1]-((Ix+Js+Jt)*diff(p(t),t)+(Iz-Iy+2*Jt-Js-Jt)*q(t)*r(t)));
# momentum is kept
H2 := add(h[i]^2,i=1..3):
dH := simplify(diff(H2,t)-2*add(h[i]*eqs[i],i=1..3));
simplify(expand(dH));
num := subs(Ix=10,Iy=15,Iz=20,Js=0.1,Jt=0.05,diff(a1(t),t)=100,diff(a1(t),t,t)=0,diff(a2(t),t)=-50,diff(a2(t),t,t)=0,eqs):
sol := dsolve({op(num),p(0)=0.01,q(0)=0.02,r(0)=0.1},{p(t),q(t),r(t)},type=numeric,method=rkf45,abserr=1e-9,relerr=1e-9):
sol(10.0);
