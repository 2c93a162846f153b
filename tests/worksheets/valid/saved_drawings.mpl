# Procedures as a saved session has them, which draw a gate and its axes
with(MBSymba_r6): with(plots): with(plottools):
draw_bar := proc (P1::POINT, P2::POINT, data, {col := 
"SteelBlue"}, $) local a, b; a := simplify(subs(data,[
MBSymba_r6_kinematics:-comp_XYZ(P1,ground)])); b := simplify(subs(data,[
MBSymba_r6_kinematics:-comp_XYZ(P2,ground)])); plottools[plottools:-arrow](a
,b,.1e-1,0,0,color = col); end proc;
draw_axis := proc (RF::frame, data, size, $) local p, vX, T; T := subs(data,RF)
; p := [MBSymba_r6_kinematics:-comp_XYZ(MBSymba_r6_kinematics:-origin(T),ground
)]; vX := [MBSymba_r6_kinematics:-comp_XYZ(MBSymba_r6_kinematics:-uvec_X(T),
ground)]; plots[plottools:-arrow](p,MBSymba_r6_foundations:-`*`(vX,size),color
 = "Red"); end proc;
kind_of := proc (obj::function, $) "a drawing"; end proc;
gate := rotate('Z',phi(t)) * translate(b,0,0):
hinge := origin(ground): handle := origin(gate):
data := [phi(t) = Pi/6, b = 2]:
display(draw_bar(hinge, handle, data), draw_axis(gate, data, 0.5), scaling = constrained);
# a drawing that is moved
moved := transform((x, y, z) -> [x, y, z+1]):
display(moved(sphere([0,0,0], 0.2, color = "Goldenrod")), sphere([0,0,0], 0.2));
kind_of(sphere([0,0,0], 1));
u := unapply([a*c, c], [a, c]): u(2, 3);
ListTools[Search](c, [a, c, e]); ListTools[Search](z, [a, c, e]);
