(program helix-1-t23, Grbl 1.1)
(part helix, aluminium, 4 mm thick)
(stock 40.00 x 30.00 x 4 mm, from X-20.000 Y-15.000)
(origin: axis of the part, Z0 on top of the stock)
(file 1 of 1, load T23 mill-8, touch it off on the stock)
(as Z0)
(origin G54, Z0 on top of the stock, units mm and mm/min)
(T23 D 8 mm: mill-8, end mill)
G17 G21 G40 G49 G80 G90 G91.1 G94
G53 G0 Z-2
(operation: seat: rough)
T23
G54 S8754 M3
G0 X3.796 Y0.146
G49
Z5
M8
Z1
G1 Z0 F2346
G3 X-2.411 Y2.936 Z-0.707 I-3.798 J-0.15 F1173
X-0.739 Y-3.727 Z-1.426 I2.415 J-2.935
X3.796 Y0.146 Z-2 I0.735 J3.731
X-2.411 Y2.936 I-3.798 J-0.15 F2346
X-0.739 Y-3.727 I2.415 J-2.935
X3.796 Y0.146 I0.735 J3.731
G0 Z5
(operation: seat: finish)
X1.998 Y-2
Z1
G1 Z-2 F4692
G3 X3.998 Y0 I0 J2 F1564
X-2.397 Y3.2 I-3.998 J0 F2346
X-1.125 Y-3.837 I2.397 J-3.2
X3.998 Y0 I1.124 J3.838
X1.998 Y2 I-2 J0 F1564
G1 Y-2 F4692
G3 X3.998 Y0 I0 J2 F1564
X-2.397 Y3.2 I-3.998 J0 F2346
X-1.125 Y-3.837 I2.397 J-3.2
X3.998 Y0 I1.124 J3.838
X1.998 Y2 I-2 J0 F1564
G0 Z5
M9
M5
G53 G0 Z-2
M30
