(program tap-inch, LinuxCNC)
(part tap-inch, aluminium, 0.1575 in thick)
(stock 1.5748 x 1.1811 x 0.1575 in, from X-0.78740 Y-0.59055)
(origin: axis of the part, Z0 on top of the stock)
(drills go 0.0721 in below the stock: leave room under the holes)
(taps go 0.1606 in below the stock: leave room under the holes)
(origin G54, Z0 on top of the stock, units inch and inch/min)
(T98 H98 D 0.20079 in: drill-5.1, drill)
(T97 H97 D 0.25 in: tap-quarter, tap)
G17 G20 G40 G49 G80 G90 G91.1 G94
G64 P0.000078 Q0
G53 G0 Z0
(operation: drill 5.1)
T98 M6
G54 S4369 M3
G0 X0 Y0
G43 H98 Z0.19686
M8
G98 G81 X0 Y0 Z-0.22962 R0.03938 F13.74
G80
M9
M5
G53 G0 Z0
(operation: quarter: tap)
T97 M6
G54 S751 M3
G0 X0 Y0
G43 H97 Z0.19686
M8
Z0.25
G33.1 Z-0.31812 K0.05
G0 Z0.19686
M9
M5
G53 G0 Z0
M30
