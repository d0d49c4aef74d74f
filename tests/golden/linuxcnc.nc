(program bracket, LinuxCNC)
(part bracket, aluminium, 6 mm thick)
(D5 holes [H7])
(origin G54, Z0 on top of the stock, units mm and mm/min)
(T1 H1 D 6 mm: spot-6, spot drill)
(T2 H2 D 5 mm: drill-5, drill)
(T3 H3 D 6 mm: mill-6, end mill)
G17 G21 G40 G49 G80 G90 G91.1 G94
G64 P0.002 Q0
G53 G0 Z0
(operation: spot drill)
T1 M6
G54 S3000 M3
G0 X10 Y10
G43 H1 Z5
M8
G98 G82 X10 Y10 Z-1.5 R1 P0.2 F160
X50
G80
M9
M5
G53 G0 Z0
(operation: drill 5)
T2 M6
G54 S2400 M3
G0 X10 Y10
G43 H2 Z5
M7
G98 G81 X10 Y10 Z-7.5 R1 F200
X50
G80
(operation: peck drill 5)
G0 Y30
G98 G83 X50 Y30 Z-17.5 R1 Q4 F180
G80
(operation: drill 5, chips broken)
G0 X20 Y35
G98 G73 X20 Y35 Z-9.5 R1 Q4 F190
G80
M9
M5
G53 G0 Z0
(operation: bore: helix)
T3 M6
G54 S8000 M3
G0 X34 Y20
G43 H3 Z5
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
X22.1234 Z-0.6334 F250
X10 Z-1.2667
X22.1234 F500
G0 Z5
M9
M5
G53 G0 Z0
(MSG, clamp the part through the bore)
M0
(operation: outside: finish)
T3 M6
G54 S8000 M3
G0 X-10 Y-3
G43 H3 Z5
Z1
G1 Z-6.3 F600
G3 X-3 Y4 I0 J7 F500
G1 Y15
Z-4.9
Y23
Z-6.3 F150
Y35 F500
G2 X2.3333 Y40.3333 I5.3333 J0
G0 Z5
M9
M5
G53 G0 Z0
M30
