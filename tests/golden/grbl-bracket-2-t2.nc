(program bracket-2-t2, Grbl 1.1)
(part bracket, aluminium, 6 mm thick)
(D5 holes [H7])
(file 2 of 3, load T2 drill-5, touch it off on the stock)
(as Z0)
(origin G54, Z0 on top of the stock, units mm and mm/min)
(T2 D 5 mm: drill-5, drill)
G17 G21 G40 G49 G80 G90 G91.1 G94
G53 G0 Z-2
(operation: drill 5)
T2
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
M30
