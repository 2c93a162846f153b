restart: with(plots): with(plottools):
setoptions(font=[HELVETICA,10]): setoptions3d(axes=none):
p := plot(sin(x), x = 0..Pi, color = red):
q := pointplot([[0,0],[1,1]]): textplot([1,0.5,"peak"]):
display([p, q, line([0,0],[1,1]), curve([[0,0],[1,0],[1,1]]), circle([0,0],1), disk([1,0],0.1), rectangle([0,0],[1,1]), polygon([[0,0],[1,0],[0,1]]), arrow([0,0],[1,1],0.1,0.2,0.3)]);
display3d([spacecurve([[0,0,0],[1,1,1]]), sphere([0,0,0],1), cylinder([0,0,0],[0,0,1],0.1), pointplot3d([[0,0,0],[1,1,1]]), textplot3d([0,0,0,"O"])]);
link := line([0,0],[1,0]): rotate(link, Pi/2, [1,0]), translate(link, 1, 2), scale(link, 2, 2), plottools[rotate](sphere([0,0,1],1), Pi, 0, 0):
listplot([1,4,9]), listplot([[0,0],[1,2]], style=point): display([arc([0,0],1,0..Pi), ellipse([0,0],1,2)]);
polygonplot([[0,0],[1,0],[0,1]]): point([0,0]):
animate(plot, [sin(x + q1), x = 0..3], q1 = 0..1, frames = 3);
sol := dsolve({diff(y(t),t) = -y(t), y(0) = 1}, numeric):
odeplot(sol, [t, y(t)], 0..1);
sol(1.0);
logplot(x^2 + 1, x = 1..100), semilogplot(20*log10(abs(1/(1+I*w))), w = 0.01..100), loglogplot(1/w, w = 1..10):
polarplot(1 + cos(theta), theta = 0..2*Pi):
spacecurve([cos(s), sin(s), s/5], s = 0..4*Pi);
plot3d(sin(x)*y, x = 0..Pi, y = 0..1), plot3d([u, v, u*v], u = 0..1, v = 0..1):
implicitplot(x^2 + y^2 = 1, x = -2..2, y = -2..2);
