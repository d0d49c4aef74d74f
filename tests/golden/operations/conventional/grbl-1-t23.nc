(program conventional-1-t23, Grbl 1.1)
(part conventional, aluminium, 4 mm thick)
(stock 40.00 x 30.00 x 4 mm, from X-20.000 Y-15.000)
(origin: axis of the part, Z0 on top of the stock)
(file 1 of 1, load T23 mill-8, touch it off on the stock as Z0)
(origin G54, Z0 on top of the stock, units mm and mm/min)
(T23 D 8 mm: mill-8, end mill)
G17 G21 G40 G49 G80 G90 G91.1 G94
G53 G0 Z0
(operation: recess: rough)
T23
G54 S8754 M3
G0 X-7.495 Y3.054
G49
Z5
M8
Z1
G1 Z0 F1960
G2 X-7.014 Y3.498 Z-0.034 I0.5 J-0.059 F980
G1 X6.937 Y3.5 Z-0.681
G2 X7.5 Y2.905 Z-0.724 I0.042 J-0.524
G1 Y-2.905 Z-0.994
G2 X6.905 Y-3.5 Z-1.039 I-0.53 J-0.065
G1 X-6.937 Z-1.681
G2 X-7.497 Y-3.028 Z-1.718 I-0.046 J0.514
G1 X-7.495 Y3.054 Z-2
G2 X-7.014 Y3.498 I0.5 J-0.059 F1960
G1 X6.937 Y3.5
G2 X7.5 Y2.905 I0.042 J-0.524
G1 Y-2.905
G2 X6.905 Y-3.5 I-0.53 J-0.065
G1 X-6.937
G2 X-7.497 Y-3.028 I-0.046 J0.514
G1 X-7.495 Y3.054
G0 Z5
(operation: recess: finish)
X4.996 Y0
Z1
G1 Z-2
G2 X0.996 Y-4 I-4 J0 F980
G1 X-6.972 F1960
G2 X-8 Y-2.972 I-0.026 J1.002 F588
G1 Y2.972 F1960
G2 X-6.972 Y4 I1.002 J0.026 F588
G1 X6.972 F1960
G2 X8 Y2.972 I0.026 J-1.002 F588
G1 Y-2.972 F1960
G2 X6.972 Y-4 I-1.002 J-0.026 F588
G1 X0.996 F1960
G2 X-3.004 Y0 I0 J4 F980
G0 Z5
M9
M5
G53 G0 Z0
M30
