(program second-side-underside, Mach3)
(part second-side-underside, aluminium, 6 mm thick)
(stock 40.00 x 30.00 x 6 mm, from X-20.000 Y-15.000)
(origin: axis of the part, Z0 on top of the stock)
(the underside: the plate is turned over about X)
(origin G55, Z0 on top of the stock, units mm and mm/min)
(T24 H24 D 6 mm: mill-6, end mill)
G17 G21 G40 G49 G80 G90 G91.1 G94
G64
G53 G0 Z0
(operation: counterbore: bore)
T24 M6
G55 S11671 M3
G0 X-1.9559 Y0
G43 H24 Z5
M8
Z1
G1 Z-3 F1750
G3 X2.9206 Y0 I2.4383 J0 F863
X-2.9206 Y0 I-2.9206 J0
X2.9206 Y0 I2.9206 J0
G1 X-2.8956 F1750
G3 X3.8603 Y0 I3.378 J0 F985
X-3.8603 Y0 I-3.8603 J0
X3.8603 Y0 I3.8603 J0
G1 X-3.8353 F1750
G3 X4.8 Y0 I4.3177 J0 F1077
X-4.8 Y0 I-4.8 J0
X4.8 Y0 I4.8 J0
G0 Z5
(operation: counterbore: finish)
X0
Z1
G1 Z-3 F3501
G3 X4.9994 Y0 I2.4997 J0 F2188
X-4.9994 Y0 I-4.9994 J0
X4.9994 Y0 I4.9994 J0
X0 Y0 I-2.4997 J0
X4.9994 Y0 I2.4997 J0
X-4.9994 Y0 I-4.9994 J0
X4.9994 Y0 I4.9994 J0
X0 Y0 I-2.4997 J0
G0 Z5
M9
M5
G53 G0 Z0
M30
