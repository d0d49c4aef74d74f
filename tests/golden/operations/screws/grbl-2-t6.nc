(program screws-2-t6, Grbl 1.1)
(part screws, aluminium, 8 mm thick)
(stock 40.00 x 30.00 x 8 mm, from X-20.000 Y-15.000)
(origin: axis of the part, Z0 on top of the stock)
(drills go 1.50 mm below the stock: leave room under the)
(holes)
(file 2 of 5, load T6 drill-4, touch it off on the stock)
(as Z0)
(origin G54, Z0 on top of the stock, units mm and mm/min)
(T6 D 4 mm: drill-4, drill)
G17 G21 G40 G49 G80 G90 G91.1 G94
G53 G0 Z-2
(operation: drill 4)
T6
G54 S6366 M3
G0 X-9 Y0
G49
Z5
M8
Z1
G1 Z-9.502 F381
G0 Z5
M9
M5
G53 G0 Z-2
M30
