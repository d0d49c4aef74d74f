(program bracket, Grbl 1.1)
(part bracket, aluminium, 6 mm thick)
(D5 holes [H7])
(origin G54, Z0 on top of the stock, units mm and mm/min)
(T1 D 6 mm: spot-6, spot drill)
(T2 D 5 mm: drill-5, drill)
(T3 D 6 mm: mill-6, end mill)
G17 G21 G40 G49 G80 G90 G91.1 G94
G53 G0 Z-2
(operation: spot drill)
T1
(load T1 spot-6, touch it off on the stock as Z0)
M0
G53 G0 Z-2
G54 S3000 M3
G0 X10 Y10
G49
Z5
M8
Z1
G1 Z-1.5 F160
G4 P0.2
G0 Z5
X50
Z1
G1 Z-1.5
G4 P0.2
G0 Z5
M9
M5
G53 G0 Z-2
(operation: drill 5)
T2
(load T2 drill-5, touch it off on the stock as Z0)
M0
G53 G0 Z-2
G54 S2400 M3
G0 X10 Y10
G49
Z5
M7
Z1
G1 Z-7.5 F200
G0 Z5
X50
Z1
G1 Z-7.5
G0 Z5
(operation: peck drill 5)
Y30
Z1
G1 Z-3 F180
G0 Z1
Z-2.75
G1 Z-7
G0 Z1
Z-6.75
G1 Z-11
G0 Z1
Z-10.75
G1 Z-15
G0 Z1
Z-14.75
G1 Z-17.5
G0 Z5
(operation: drill 5, chips broken)
X20 Y35
Z1
G1 Z-3 F190
G0 Z-2.75
G1 Z-7
G0 Z-6.75
G1 Z-9.5
G0 Z5
M9
M5
G53 G0 Z-2
(operation: bore: helix)
T3
(load T3 mill-6, touch it off on the stock as Z0)
M0
G53 G0 Z-2
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
