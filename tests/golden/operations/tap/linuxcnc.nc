(program tap, LinuxCNC)
(part tap, aluminium, 16 mm thick)
(stock 40.00 x 30.00 x 16 mm, from X-20.000 Y-15.000)
(origin: axis of the part, Z0 on top of the stock)
(drills go 1.80 mm below the stock: leave room under the holes)
(taps go 4.00 mm below the stock: leave room under the holes)
(origin G54, Z0 on top of the stock, units mm and mm/min)
(T1 H1 D 6 mm: spot-6, spot drill)
(T7 H7 D 5 mm: drill-5, drill)
(T94 H94 D 6 mm: tap-m6, tap)
G17 G21 G40 G49 G80 G90 G91.1 G94
G64 P0.002 Q0
G53 G0 Z0
(operation: spot drill)
T1 M6
G54 S3714 M3
G0 X-8 Y0
G43 H1 Z5
M8
G98 G82 X-8 Y0 Z-1.5 R1 P0.2 F222
X8
G80
M9
M5
G53 G0 Z0
(operation: drill 5)
T7 M6
G54 S5093 M3
G0 X-8 Y0
G43 H7 Z5
M8
G98 G73 X-8 Y0 Z-17.8022 R1 Q5 F376
G80
(operation: drill 5 to 12.5)
G0 X8
G98 G81 X8 Y0 Z-14 R1
G80
M9
M5
G53 G0 Z0
(operation: m6: tap)
T94 M6
G54 S795 M3
G0 X-8 Y0
G43 H94 Z5
M8
G33.1 Z-20 K1
(operation: blind-m6: tap)
G0 X8
G33.1 Z-12 K1
M9
M5
G53 G0 Z0
M30
