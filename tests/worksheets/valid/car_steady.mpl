# The second sheet of the car: the equations of a steady turn from a file, a matrix of them, and MATLAB code.
restart: with(MBSymba_r6):
read "car_equations.mpl":
nops(eqns);
show(chassis, 'synthetic'):
steady := subs(diff(u(t),t) = 0, diff(v(t),t) = 0, diff(Omega(t),t) = 0, diff(z(t),t,t) = 0, diff(mu(t),t,t) = 0, diff(phi(t),t,t) = 0,
  diff(z(t),t) = 0, diff(mu(t),t) = 0, diff(phi(t),t) = 0, eqns):
steady := subs(u(t) = V, v(t) = v0, Omega(t) = V/rho, z(t) = 0, mu(t) = 0, phi(t) = 0, delta(t) = delta0, steady):
loads := {X[1](t) = 0, X[2](t) = 0, X[3](t) = Xr, X[4](t) = Xr, Y[1](t) = Yf/2, Y[2](t) = Yf/2, Y[3](t) = Yr/2, Y[4](t) = Yr/2, N[1](t) = Nf - dN, N[2](t) = Nf + dN, N[3](t) = Nr - dN, N[4](t) = Nr + dN}:
steady := map(simplify, subs(loads, steady)):
A, c := LinearAlgebra[GenerateMatrix](steady, [Xr, Yf, Yr, Nf, Nr, dN]):
A[2,2], A[3,4];
forces := solve({op(steady)}, {Xr, Yf, Yr, Nf, Nr, dN}):
Y__f := simplify(subs(forces, Yf)):
code := CodeGeneration[Matlab]([Y__f, simplify(subs(forces, dN))], optimize, output = string):
length(code) > 0;
codegen[cost](Y__f);
