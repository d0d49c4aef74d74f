(program helix, Grbl 1.1)
(part helix, aluminium, 4 mm thick)
(stock 40.00 x 30.00 x 4 mm, from X-20.000 Y-15.000)
(origin: axis of the part, Z0 on top of the stock)
(origin G54, Z0 on top of the stock, units mm and mm/min)
(T23 D 8 mm: mill-8, end mill)
G17 G21 G40 G49 G80 G90 G91.1 G94
G53 G0 Z0
(operation: seat: rough)
T23
(load T23 mill-8, touch it off on the stock as Z0)
M0
G53 G0 Z0
G54 S8754 M3
G0 X3.799 Y0
G49
Z5
M8
Z1
G1 Z0 F1960
G3 X-3.777 Y0.405 Z-0.966 I-3.799 J-0.002 F980
X3.738 Y-0.676 Z-1.944 I3.777 J-0.404
X3.799 Y0 Z-2 I-4.369 J0.732
X-3.777 Y0.405 I-3.799 J-0.002 F1960
X3.738 Y-0.676 I3.777 J-0.404
X3.799 Y0 I-4.369 J0.732
G0 Z5
(operation: seat: finish)
X1.997 Y-2
Z1
G1 Z-2
G3 X3.997 Y0 I0 J2 F653
X-3.967 Y0.49 I-3.997 J0 F980
X3.877 Y-0.973 I3.967 J-0.49
X3.997 Y0 I-3.898 J0.976 F982
X1.997 Y2 I-2 J0 F653
G1 Y-2 F1960
G3 X3.997 Y0 I0 J2 F653
X-3.967 Y0.49 I-3.997 J0 F980
X3.877 Y-0.973 I3.967 J-0.49
X3.997 Y0 I-3.898 J0.976 F982
X1.997 Y2 I-2 J0 F653
G0 Z5
M9
M5
G53 G0 Z0
M30
