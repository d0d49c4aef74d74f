(program offsets-1-t1, Grbl 1.1)
(part offsets, aluminium, 3 mm thick)
(stock 72.00 x 82.00 x 3 mm, from X-36.000 Y-41.000)
(origin: axis of the part, Z0 on top of the stock)
(drills go 1.80 mm below the stock: leave room under the)
(holes)
(file 1 of 3, load T1 spot-6, touch it off on the stock as)
(Z0 of G54, G55, each on its own stock)
(origin G54, G55, Z0 on top of the stock, units mm and)
(mm/min)
(T1 D 6 mm: spot-6, spot drill)
G17 G21 G40 G49 G80 G90 G91.1 G94
G53 G0 Z-2
T1
G54 S3714 M3
(operation: spot drill)
G0 X0 Y0
G49
Z5
M8
Z1
G1 Z-1.5 F222
G4 P0.2
G0 Z5
M9
G53 G0 Z-2
G55
(operation: spot drill)
G0 X0 Y0
G49
Z5
M8
Z1
G1 Z-1.5 F222
G4 P0.2
G0 Z5
M9
G53 G0 Z-2
M5
M30
