(program bracket-1-t1, Grbl 1.1)
(part bracket, aluminium, 6 mm thick)
(D5 holes [H7])
(file 1 of 3, load T1 spot-6, touch it off on the stock as)
(Z0)
(origin G54, Z0 on top of the stock, units mm and mm/min)
(T1 D 6 mm: spot-6, spot drill)
G17 G21 G40 G49 G80 G90 G91.1 G94
G53 G0 Z-2
(operation: spot drill)
T1
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
M30
