# Objects are tables: shared by assignment, copied by copy, and their fields can be written.
restart: with(MBSymba_r6):
T := translate(x(t), 0, 0):
B1 := make_BODY(T, m1, Ix, Iy, Iz, Cyz, Cxz, Cxy):
B1[inertia];
B2 := B1: B2[mass] := m2: B1[mass];
B3 := copy(B1): B3[mass] := -m2: B1[mass], B3[mass];
anti_body := proc(BB::BODY) local A; A := copy(BB); A[mass] := -BB[mass]; A[inertia] := -BB[inertia]; A end proc:
AB := anti_body(B1):
kinetic_energy({B1, AB});
P := make_POINT(T, 1, 2, 3): Q := translate(0, 0, a, P): comp_XYZ(Q);
v := make_VECTOR(T, 1, 0, 0): comp_XYZ(rotate('Z', Pi/2, v));
w := 2*v + make_VECTOR(T, 0, k, 0): comp_XYZ(-w/2);
comp_XYZ(P + w); comp_XYZ(Q - P);
n := uvec_Z(rotate('X', q)): dot_prod(n, uvec_Z(ground)); comp_XYZ(cross_prod(uvec_X(ground), n), ground);
L := linear_momentum({B1, AB}): comp_XYZ(L);
show(angular_momentum(B1, P), 'syntetic');
a := 5: comp_XYZ(Q);
S := GetLicenseStatus(): S[StatusCode];
