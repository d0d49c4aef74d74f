(program second-side-underside-1-t24, Grbl 1.1)
(part second-side-underside, aluminium, 6 mm thick)
(stock 40.00 x 30.00 x 6 mm, from X-20.000 Y-15.000)
(origin: axis of the part, Z0 on top of the stock)
(the underside: the plate is turned over about X)
(file 1 of 1, load T24 mill-6, touch it off on the stock)
(as Z0)
(origin G55, Z0 on top of the stock, units mm and mm/min)
(T24 D 6 mm: mill-6, end mill)
G17 G21 G40 G49 G80 G90 G91.1 G94
G53 G0 Z-2
(operation: counterbore: bore)
T24
G55 S11671 M3
G0 X-1.956 Y0
G49
Z5
M8
Z1
G1 Z-3 F1750
G3 X2.92 Y0 I2.438 J0 F863
X-2.92 Y0 I-2.92 J0
X2.92 Y0 I2.92 J0
G1 X-2.895 F1750
G3 X3.86 Y0 I3.377 J0 F985
X-3.86 Y0 I-3.86 J0
X3.86 Y0 I3.86 J0
G1 X-3.835 F1750
G3 X4.8 Y0 I4.317 J0 F1077
X-4.8 Y0 I-4.8 J0
X4.8 Y0 I4.8 J0
G0 Z5
(operation: counterbore: finish)
X0
Z1
G1 Z-3 F3501
G3 X4.999 Y0 I2.5 J0 F2188
X-4.999 Y0 I-4.999 J0
X4.999 Y0 I4.999 J0
X0 Y0 I-2.499 J0
X4.999 Y0 I2.5 J0
X-4.999 Y0 I-4.999 J0
X4.999 Y0 I4.999 J0
X0 Y0 I-2.499 J0
G0 Z5
M9
M5
G53 G0 Z-2
M30
