(program tap-floating, Mach3)
(part tap-floating, aluminium, 4 mm thick)
(stock 40.00 x 30.00 x 4 mm, from X-20.000 Y-15.000)
(origin: axis of the part, Z0 on top of the stock)
(drills go 1.80 mm below the stock: leave room under the holes)
(taps go 2.00 mm below the stock: leave room under the holes)
(origin G54, Z0 on top of the stock, units mm and mm/min)
(T7 H7 D 5 mm: drill-5, drill)
(T96 H96 D 6 mm: tap-m6-floating, tap)
(dwells are in seconds: G04 dwell in ms must be off)
G17 G21 G40 G49 G80 G90 G91.1 G94
G64
G53 G0 Z0
(operation: drill 5)
T7 M6
G54 S5093 M3
G0 X-8 Y0
G43 H7 Z5
M8
G98 G81 X-8 Y0 Z-5.8022 R1 F376
X8
G80
M9
M5
G53 G0 Z0
(operation: m6: tap)
T96 M6
G54 S795 M3
G0 X-8 Y0
G43 H96 Z5
M8
G98 G84 X-8 Y0 Z-6 R5 F795
G80
(operation: m6-2: tap)
G0 X8
G98 G84 X8 Y0 Z-6 R5 F795
G80
M9
M5
G53 G0 Z0
M30
