# Three sheets in one file: each begins anew.
restart: with(MBSymba_r6):
linear_modeling({x(t), phi(t)}):
T := translate(x(t),0,0) * rotate('Z',phi(t));
restart: with(MBSymba_r6):
T := translate(x(t),0,0) * rotate('Z',phi(t)); small_vars;
x := 3;
restart:
x; T;
