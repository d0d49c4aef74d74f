(program peck-1-t4, Grbl 1.1)
(part peck, aluminium, 18 mm thick)
(stock 40.00 x 30.00 x 18 mm, from X-20.000 Y-15.000)
(origin: axis of the part, Z0 on top of the stock)
(drills go 1.20 mm below the stock: leave room under the)
(holes)
(file 1 of 1, load T4 drill-3, touch it off on the stock)
(as Z0)
(origin G54, Z0 on top of the stock, units mm and mm/min)
(T4 D 3 mm: drill-3, drill)
G17 G21 G40 G49 G80 G90 G91.1 G94
G53 G0 Z-2
(operation: drill 3)
T4
G54 S8488 M3
G0 X-10 Y5
G49
Z5
M8
Z1
G1 Z-2 F373
G0 Z1
Z-1.75
G1 Z-5
G0 Z1
Z-4.75
G1 Z-8
G0 Z1
Z-7.75
G1 Z-11
G0 Z1
Z-10.75
G1 Z-14
G0 Z1
Z-13.75
G1 Z-17
G0 Z1
Z-16.75
G1 Z-19.202
G0 Z5
X10 Y-5
Z1
G1 Z-2
G0 Z1
Z-1.75
G1 Z-5
G0 Z1
Z-4.75
G1 Z-8
G0 Z1
Z-7.75
G1 Z-11
G0 Z1
Z-10.75
G1 Z-14
G0 Z1
Z-13.75
G1 Z-17
G0 Z1
Z-16.75
G1 Z-19.202
G0 Z5
M9
M5
G53 G0 Z-2
M30
