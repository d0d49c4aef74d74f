(program drill-2-t9, Grbl 1.1)
(part drill, aluminium, 4 mm thick)
(stock 40.00 x 30.00 x 4 mm, from X-20.000 Y-15.000)
(origin: axis of the part, Z0 on top of the stock)
(drills go 2.70 mm below the stock: leave room under the)
(holes)
(file 2 of 2, load T9 drill-8, touch it off on the stock)
(as Z0)
(origin G54, Z0 on top of the stock, units mm and mm/min)
(T9 D 8 mm: drill-8, drill)
G17 G21 G40 G49 G80 G90 G91.1 G94
G53 G0 Z-2
(operation: drill 8)
T9
G54 S3183 M3
G0 X10 Y8
G49
Z5
M8
Z1
G1 Z-6.704 F381
G0 Z5
M9
M5
G53 G0 Z-2
M30
