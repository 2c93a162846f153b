restart: with(plots): with(plottools):
setoptions(font=[HELVETICA,10]): setoptions3d(axes=none):
p := plot(sin(x), x = 0..Pi, color = red):
q := pointplot([[0,0],[1,1]]): textplot([1,0.5,"peak"]):
display([p, q, line([0,0],[1,1]), curve([[0,0],[1,0],[1,1]]), circle([0,0],1), disk([1,0],0.1), rectangle([0,0],[1,1]), polygon([[0,0],[1,0],[0,1]]), arrow([0,0],[1,1],0.1,0.2,0.3)]);
display3d([spacecurve([[0,0,0],[1,1,1]]), sphere([0,0,0],1), cylinder([0,0,0],[0,0,1],0.1), pointplot3d([[0,0,0],[1,1,1]]), textplot3d([0,0,0,"O"])]);
polygonplot([[0,0],[1,0],[0,1]]): point([0,0]):
animate(plot, [sin(x + q1), x = 0..3], q1 = 0..1, frames = 3);
sol := dsolve({diff(y(t),t) = -y(t), y(0) = 1}, numeric):
odeplot(sol, [t, y(t)], 0..1);
sol(1.0);
