with(MBSymba_r6):
P := origin([1,2,3]);
y := 2;
