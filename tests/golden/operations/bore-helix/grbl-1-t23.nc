(program bore-helix-1-t23, Grbl 1.1)
(part bore-helix, aluminium, 4 mm thick)
(stock 40.00 x 30.00 x 4 mm, from X-20.000 Y-15.000)
(origin: axis of the part, Z0 on top of the stock)
(file 1 of 1, load T23 mill-8, touch it off on the stock)
(as Z0)
(origin G54, Z0 on top of the stock, units mm and mm/min)
(T23 D 8 mm: mill-8, end mill)
G17 G21 G40 G49 G80 G90 G91.1 G94
G53 G0 Z-2
(operation: bore: bore)
T23
G54 S8754 M3
G0 X2.8 Y0
G49
Z5
M8
Z1
G1 Z0 F2346
G3 X-2.8 Y0 Z-0.43 I-2.8 J0 F966
X2.8 Y0 Z-0.86 I2.8 J0
X-2.8 Y0 Z-1.29 I-2.8 J0
X2.8 Y0 Z-1.72 I2.8 J0
X-2.8 Y0 Z-2.15 I-2.8 J0
X2.8 Y0 Z-2.58 I2.8 J0
X-2.8 Y0 Z-3.01 I-2.8 J0
X2.8 Y0 Z-3.44 I2.8 J0
X-2.8 Y0 Z-3.87 I-2.8 J0
X2.8 Y0 Z-4.3 I2.8 J0
X-2.8 Y0 I-2.8 J0
X2.8 Y0 I2.8 J0
G1 X0 F2346
G0 Z5
(operation: bore: finish)
Z1
G1 Z-4.3 F4692
G3 X2.999 Y0 I1.5 J0 F2011
X-2.999 Y0 I-2.999 J0
X2.999 Y0 I2.999 J0
X0 Y0 I-1.499 J0
X2.999 Y0 I1.5 J0
X-2.999 Y0 I-2.999 J0
X2.999 Y0 I2.999 J0
X0 Y0 I-1.499 J0
G0 Z5
(operation: seat: bore)
X3.2
Z1
G1 Z0 F2346
G3 X-3.2 Y0 Z-0.5 I-3.2 J0 F1043
X3.2 Y0 Z-1 I3.2 J0
X-3.2 Y0 Z-1.5 I-3.2 J0
X3.2 Y0 Z-2 I3.2 J0
X-3.2 Y0 I-3.2 J0
X3.2 Y0 I3.2 J0
G1 X0 F2346
X-3.175
G3 X4.5 Y0 I3.837 J0 F1242
X-4.5 Y0 I-4.5 J0
X4.5 Y0 I4.5 J0
G1 X-4.475 F2346
G3 X5.8 Y0 I5.137 J0 F1388
X-5.8 Y0 I-5.8 J0
X5.8 Y0 I5.8 J0
G0 Z5
(operation: seat: finish)
X0
Z1
G1 Z-2 F4692
G3 X5.999 Y0 I3 J0 F2815
X-5.999 Y0 I-5.999 J0
X5.999 Y0 I5.999 J0
X0 Y0 I-2.999 J0
X5.999 Y0 I3 J0
X-5.999 Y0 I-5.999 J0
X5.999 Y0 I5.999 J0
X0 Y0 I-2.999 J0
G0 Z5
M9
M5
G53 G0 Z-2
M30
