(program chamfer-2-t40, Grbl 1.1)
(part chamfer, aluminium, 3 mm thick)
(stock 40.00 x 30.00 x 3 mm, from X-20.000 Y-15.000)
(origin: axis of the part, Z0 on top of the stock)
(file 2 of 2, load T40 chamfer-6, touch it off on the)
(stock as Z0)
(origin G54, Z0 on top of the stock, units mm and mm/min)
(T40 D 6 mm: chamfer-6, chamfer mill)
G17 G21 G40 G49 G80 G90 G91.1 G94
G53 G0 Z-2
(operation: edge: chamfer)
T40
G54 S11671 M3
G0 X5.132 Y-6.697
G49
Z5
M8
Z1
G1 Z0 F1050
G3 X9.698 Y-1.998 Z-0.377 I-0.133 J4.697 F530
G1 Y1.998 Z-0.584
G3 X9.173 Y4.158 Z-0.7 I-4.699 J0.001
X4.998 Y6.699 I-4.174 J-2.158 F1050
G1 X-4.998
G3 X-9.698 Y1.998 I-0.001 J-4.699
G1 Y-1.998
G3 X-4.998 Y-6.699 I4.699 J-0.002
G1 X4.998
X5.132 Y-6.697
G3 X9.698 Y-1.998 I-0.133 J4.697
G1 Y1.998
G3 X9.173 Y4.158 I-4.699 J0.001
G0 Z5
M9
M5
G53 G0 Z-2
M30
