(program floor-1-t26, Grbl 1.1)
(part floor, aluminium, 4 mm thick)
(stock 40.00 x 30.00 x 4 mm, from X-20.000 Y-15.000)
(origin: axis of the part, Z0 on top of the stock)
(file 1 of 2, load T26 mill-4, touch it off on the stock)
(as Z0)
(origin G54, Z0 on top of the stock, units mm and mm/min)
(T26 D 4 mm: mill-4, end mill)
G17 G21 G40 G49 G80 G90 G91.1 G94
G53 G0 Z-2
(operation: seat: bore)
T26
G54 S12000 M3
G0 X15.8 Y0
G49
Z5
M8
Z1
G1 Z0 F1188
G3 X14.2 Y0 Z-0.117 I-0.8 J0 F356
X15.8 Y0 Z-0.234 I0.8 J0
X14.2 Y0 Z-0.35 I-0.8 J0
X15.8 Y0 Z-0.467 I0.8 J0
X14.2 Y0 Z-0.584 I-0.8 J0
X15.8 Y0 Z-0.7 I0.8 J0
X14.2 Y0 I-0.8 J0
X15.8 Y0 I0.8 J0
G1 X15 F1188
X15.8
G3 X14.2 Y0 Z-0.775 I-0.8 J0 F850
X15.8 Y0 Z-0.85 I0.8 J0
X14.2 Y0 Z-0.925 I-0.8 J0
X15.8 Y0 Z-1 I0.8 J0
X14.2 Y0 I-0.8 J0 F356
X15.8 Y0 I0.8 J0
G1 X15 F1188
G0 Z5
(operation: seat: finish)
Z1
G1 Z-1 F1687
G3 X15.999 Y0 I0.5 J0 F562
X14.001 Y0 I-0.999 J0
X15.999 Y0 I0.999 J0
X15 Y0 I-0.499 J0
X15.999 Y0 I0.5 J0
X14.001 Y0 I-0.999 J0
X15.999 Y0 I0.999 J0
X15 Y0 I-0.499 J0
G0 Z5
M9
M5
G53 G0 Z-2
M30
