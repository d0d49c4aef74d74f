(program tap-left, LinuxCNC)
(part tap-left, aluminium, 4 mm thick)
(stock 40.00 x 30.00 x 4 mm, from X-20.000 Y-15.000)
(origin: axis of the part, Z0 on top of the stock)
(drills go 1.80 mm below the stock: leave room under the holes)
(taps go 4.00 mm below the stock: leave room under the holes)
(origin G54, Z0 on top of the stock, units mm and mm/min)
(T7 H7 D 5 mm: drill-5, drill)
(T95 H95 D 6 mm: tap-m6-left, tap)
G17 G21 G40 G49 G80 G90 G91.1 G94
G64 P0.002 Q0
G53 G0 Z0
(operation: drill 5)
T7 M6
G54 S5093 M3
G0 X0 Y0
G43 H7 Z5
M8
G98 G81 X0 Y0 Z-5.8022 R1 F376
G80
M9
M5
G53 G0 Z0
(operation: m6: tap)
T95 M6
G54 S795 M4
G0 X0 Y0
G43 H95 Z5
M8
G33.1 Z-8 K1
M9
M5
G53 G0 Z0
M30
