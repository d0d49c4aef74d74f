(program engrave, Mach3)
(part engrave, aluminium, 4 mm thick)
(stock 40.00 x 30.00 x 4 mm, from X-20.000 Y-15.000)
(origin: axis of the part, Z0 on top of the stock)
(drills go 1.80 mm below the stock: leave room under the holes)
(origin G54, Z0 on top of the stock, units mm and mm/min)
(T7 H7 D 5 mm: drill-5, drill)
(T41 H41 D 3 mm: engrave-3, chamfer mill)
G17 G21 G40 G49 G80 G90 G91.1 G94
G64
G53 G0 Z0
(operation: drill 5)
T7 M6
G54 S5093 M3
G0 X-14 Y0
G43 H7 Z5
M8
G98 G81 X-14 Y0 Z-5.8022 R1 F376
G80
M9
M5
G53 G0 Z0
(operation: number: engrave)
T41 M6
G54 S12000 M3
G0 X-9.6667 Y-2.5
G43 H41 Z5
M8
Z1
G1 Z0 F120
Z-0.2 F36
Y2.5 F120
X-8 Y0
X-6.3333 Y2.5
Y-2.5
G0 Z5
X-4.6667 Y2.5
Z1
G1 Z0
Z-0.2 F36
X-3.8333 Y-2.5 F120
X-3 Y0
X-2.1667 Y-2.5
X-1.3333 Y2.5
G0 Z5
X1.1667 Y0
Z1
G1 Z0
Z-0.2 F36
X2.8333 F120
G0 Z5
X5.3333 Y1.6667
Z1
G1 Z0
Z-0.2 F36
X6.1667 Y2.5 F120
X7.8333
X8.6667 Y1.6667
Y0.8333
X5.3333 Y-2.5
X8.6667
G0 Z5
X13.6667 Y2.5
Z1
G1 Z0
Z-0.2 F36
X10.3333 F120
Y0.8333
X12.8333
X13.6667 Y0
Y-1.6667
X12.8333 Y-2.5
X10.3333
G0 Z5
M9
M5
G53 G0 Z0
M30
