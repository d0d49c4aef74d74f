(program second-side-1-t24, Grbl 1.1)
(part second-side, aluminium, 6 mm thick)
(stock 40.00 x 30.00 x 6 mm, from X-20.000 Y-15.000)
(origin: axis of the part, Z0 on top of the stock)
(file 1 of 1, load T24 mill-6, touch it off on the stock)
(as Z0)
(origin G54, Z0 on top of the stock, units mm and mm/min)
(T24 D 6 mm: mill-6, end mill)
G17 G21 G40 G49 G80 G90 G91.1 G94
G53 G0 Z-2
(operation: bore: bore)
T24
G54 S11671 M3
G0 X1.8 Y0
G49
Z5
M8
Z1
G1 Z0 F1750
G3 X-1.8 Y0 Z-0.287 I-1.8 J0 F656
X1.8 Y0 Z-0.573 I1.8 J0
X-1.8 Y0 Z-0.86 I-1.8 J0
X1.8 Y0 Z-1.146 I1.8 J0
X-1.8 Y0 Z-1.432 I-1.8 J0
X1.8 Y0 Z-1.719 I1.8 J0
X-1.8 Y0 Z-2.005 I-1.8 J0
X1.8 Y0 Z-2.291 I1.8 J0
X-1.8 Y0 Z-2.578 I-1.8 J0
X1.8 Y0 Z-2.864 I1.8 J0
X-1.8 Y0 Z-3.15 I-1.8 J0
X1.8 Y0 Z-3.437 I1.8 J0
X-1.8 Y0 Z-3.723 I-1.8 J0
X1.8 Y0 Z-4.01 I1.8 J0
X-1.8 Y0 Z-4.296 I-1.8 J0
X1.8 Y0 Z-4.582 I1.8 J0
X-1.8 Y0 Z-4.869 I-1.8 J0
X1.8 Y0 Z-5.155 I1.8 J0
X-1.8 Y0 Z-5.441 I-1.8 J0
X1.8 Y0 Z-5.728 I1.8 J0
X-1.8 Y0 Z-6.014 I-1.8 J0
X1.8 Y0 Z-6.3 I1.8 J0
X-1.8 Y0 I-1.8 J0
X1.8 Y0 I1.8 J0
G1 X0 F1750
G0 Z5
(operation: bore: finish)
Z1
G1 Z-6.3 F3196
G3 X1.999 Y0 I1 J0 F1278
X-1.999 Y0 I-1.999 J0
X1.999 Y0 I1.999 J0
X0 Y0 I-0.999 J0
X1.999 Y0 I1 J0
X-1.999 Y0 I-1.999 J0
X1.999 Y0 I1.999 J0
X0 Y0 I-0.999 J0
G0 Z5
M9
M5
G53 G0 Z-2
M30
