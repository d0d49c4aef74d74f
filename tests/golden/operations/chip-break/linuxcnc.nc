(program chip-break, LinuxCNC)
(part chip-break, aluminium, 18 mm thick)
(stock 40.00 x 30.00 x 18 mm, from X-20.000 Y-15.000)
(origin: axis of the part, Z0 on top of the stock)
(drills go 1.80 mm below the stock: leave room under the holes)
(origin G54, Z0 on top of the stock, units mm and mm/min)
(T7 H7 D 5 mm: drill-5, drill)
G17 G21 G40 G49 G80 G90 G91.1 G94
G64 P0.002 Q0
G53 G0 Z0
(operation: drill 5)
T7 M6
G54 S5093 M3
G0 X-10 Y5
G43 H7 Z5
M8
G98 G73 X-10 Y5 Z-19.8022 R1 Q5 F376
X10 Y-5
G80
M9
M5
G53 G0 Z0
M30
