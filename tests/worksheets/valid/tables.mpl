# Entries of tables and indexed names, slices, sequences, and procedures with types and defaults.
restart: with(MBSymba_r6):
solz := array[np]: solz[1] := 5: solz[1];
for i to 3 do P[i] := make_POINT(translate(i*l, 0, 0), 0, h[i], 0): m[i] := i*mu: end:
xs := [seq(comp_X(P[i], ground), i = 1..3)]; xs[2..3]; xs[-1]; xs[2..-1];
B := [seq(make_BODY(P[i], m[i]), i = 1..3)]:
G := proc(L::list, {first := 1}) local M, k, S; M := 0; S := 0;
  for k from first to nops(L) do M := M + L[k][mass]; S := S + L[k][mass]*comp_X(CoM(L[k]), ground); end do;
  return S/M;
end proc:
G(B), G(B, first = 2);
fact := proc(n::integer) if n < 2 then 1 else n*fact(n-1) end if end proc: fact(5);
total := proc() add(args[i], i = 1..nargs) end proc: total(1, 2, x);
sign_of := x -> if x > 0 then 1 elif x < 0 then -1 else 0 end if: map(sign_of, [3, -2, 0]);
f := (x, y) -> x^2 + y: f(2, 1); (a1, b1) := op([1, 2]): a1 + b1;
for e in [u, v] do print(e^2) end do:
eqs := [x + y = 1, x - y = 3]: lhs~(eqs); rhs~(eqs); subs(solve({op(eqs)}, {x, y}), [x, y]);
A := Matrix(2, 2, [[1, 2], [3, 4]]): A^%T; A[1..2, 2];
s := table([one = 1]): s2 := s: s2[one] := 2: s[one];
z := try_this(3): whattype(z);
try error "wrong %1", 7 catch "wrong": print(caught) end try:
while nops(xs) > 2 do xs := xs[1..-2] end do: xs;
