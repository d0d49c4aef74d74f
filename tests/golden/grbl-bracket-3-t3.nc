(program bracket-3-t3, Grbl 1.1)
(part bracket, aluminium, 6 mm thick)
(D5 holes [H7])
(file 3 of 3, load T3 mill-6, touch it off on the stock as)
(Z0)
(origin G54, Z0 on top of the stock, units mm and mm/min)
(T3 D 6 mm: mill-6, end mill)
G17 G21 G40 G49 G80 G90 G91.1 G94
G53 G0 Z-2
(operation: bore: helix)
T3
G54 S8000 M3
G0 X34 Y20
G49
Z5
M8
Z1
G1 Z0 F300
G3 X34 Y20 Z-2 I-4 J0 F250
X34 Y20 Z-4 I-4 J0
X34 Y20 I-4 J0 F400
G1 X30
G0 Z5
(operation: slot: ramp and finish)
X10 Y30
Z1
G1 Z0 F300
X22.123 Z-0.634 F250
X10 Z-1.267
X22.123 F500
G0 Z5
M9
M5
G53 G0 Z-2
(clamp the part through the bore)
M0
(operation: outside: finish)
G54 S8000 M3
G0 X-10 Y-3
G49
Z5
Z1
G1 Z-6.3 F600
G3 X-3 Y4 I0 J7 F500
G1 Y15
Z-4.9
Y23
Z-6.3 F150
Y35 F500
G2 X2.333 Y40.333 I5.333 J0
G0 Z5
M9
M5
G53 G0 Z-2
M30
