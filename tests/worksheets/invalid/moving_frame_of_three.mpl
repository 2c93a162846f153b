with(MBSymba_r6):
use_moving_frame(u, v, r);
y := 2;
