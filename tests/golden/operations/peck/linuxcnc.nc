(program peck, LinuxCNC)
(part peck, aluminium, 18 mm thick)
(stock 40.00 x 30.00 x 18 mm, from X-20.000 Y-15.000)
(origin: axis of the part, Z0 on top of the stock)
(drills go 1.20 mm below the stock: leave room under the holes)
(origin G54, Z0 on top of the stock, units mm and mm/min)
(T4 H4 D 3 mm: drill-3, drill)
G17 G21 G40 G49 G80 G90 G91.1 G94
G64 P0.002 Q0
G53 G0 Z0
(operation: drill 3)
T4 M6
G54 S8488 M3
G0 X-10 Y5
G43 H4 Z5
M8
G98 G83 X-10 Y5 Z-19.2013 R1 Q3 F373
X10 Y-5
G80
M9
M5
G53 G0 Z0
M30
