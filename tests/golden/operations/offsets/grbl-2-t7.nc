(program offsets-2-t7, Grbl 1.1)
(part offsets, aluminium, 3 mm thick)
(stock 72.00 x 82.00 x 3 mm, from X-36.000 Y-41.000)
(origin: axis of the part, Z0 on top of the stock)
(drills go 1.80 mm below the stock: leave room under the)
(holes)
(file 2 of 3, load T7 drill-5, touch it off on the stock)
(as Z0 of G54, G55, each on its own stock)
(origin G54, G55, Z0 on top of the stock, units mm and)
(mm/min)
(T7 D 5 mm: drill-5, drill)
G17 G21 G40 G49 G80 G90 G91.1 G94
G53 G0 Z-2
T7
G54 S5093 M3
(operation: drill 5)
G0 X0 Y0
G49
Z5
M8
Z1
G1 Z-4.803 F376
G0 Z5
M9
G53 G0 Z-2
G55
(operation: drill 5)
G0 X0 Y0
G49
Z5
M8
Z1
G1 Z-4.803 F376
G0 Z5
M9
G53 G0 Z-2
M5
M30
