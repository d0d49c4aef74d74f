(program spot-1-t1, Grbl 1.1)
(part spot, aluminium, 4 mm thick)
(stock 40.00 x 30.00 x 4 mm, from X-20.000 Y-15.000)
(origin: axis of the part, Z0 on top of the stock)
(drills go 1.80 mm below the stock: leave room under the)
(holes)
(file 1 of 2, load T1 spot-6, touch it off on the stock as)
(Z0)
(origin G54, Z0 on top of the stock, units mm and mm/min)
(T1 D 6 mm: spot-6, spot drill)
G17 G21 G40 G49 G80 G90 G91.1 G94
G53 G0 Z-2
(operation: spot drill)
T1
G54 S3714 M3
G0 X-10 Y5
G49
Z5
M8
Z1
G1 Z-1.5 F222
G4 P0.2
G0 Z5
X10 Y-5
Z1
G1 Z-1.5
G4 P0.2
G0 Z5
M9
M5
G53 G0 Z-2
M30
