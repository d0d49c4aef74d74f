(program drill, Mach3)
(part drill, aluminium, 4 mm thick)
(stock 40.00 x 30.00 x 4 mm, from X-20.000 Y-15.000)
(origin: axis of the part, Z0 on top of the stock)
(drills go 2.70 mm below the stock: leave room under the holes)
(origin G54, Z0 on top of the stock, units mm and mm/min)
(T7 H7 D 5 mm: drill-5, drill)
(T9 H9 D 8 mm: drill-8, drill)
G17 G21 G40 G49 G80 G90 G91.1 G94
G64
G53 G0 Z0
(operation: drill 5)
T7 M6
G54 S5093 M3
G0 X-10 Y5
G43 H7 Z5
M8
G98 G81 X-10 Y5 Z-5.8022 R1 F376
X10 Y-5
G80
M9
M5
G53 G0 Z0
(operation: drill 8)
T9 M6
G54 S3183 M3
G0 X10 Y8
G43 H9 Z5
M8
G98 G81 X10 Y8 Z-6.7034 R1 F381
G80
M9
M5
G53 G0 Z0
M30
