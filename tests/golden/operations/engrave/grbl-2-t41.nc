(program engrave-2-t41, Grbl 1.1)
(part engrave, aluminium, 4 mm thick)
(stock 40.00 x 30.00 x 4 mm, from X-20.000 Y-15.000)
(origin: axis of the part, Z0 on top of the stock)
(drills go 1.80 mm below the stock: leave room under the)
(holes)
(file 2 of 2, load T41 engrave-3, touch it off on the)
(stock as Z0)
(origin G54, Z0 on top of the stock, units mm and mm/min)
(T41 D 3 mm: engrave-3, chamfer mill)
G17 G21 G40 G49 G80 G90 G91.1 G94
G53 G0 Z-2
(operation: number: engrave)
T41
G54 S12000 M3
G0 X-9.667 Y-2.5
G49
Z5
M8
Z1
G1 Z0 F120
Z-0.2 F36
Y2.5 F120
X-8 Y0
X-6.333 Y2.5
Y-2.5
G0 Z5
X-4.667 Y2.5
Z1
G1 Z0
Z-0.2 F36
X-3.833 Y-2.5 F120
X-3 Y0
X-2.167 Y-2.5
X-1.333 Y2.5
G0 Z5
X1.167 Y0
Z1
G1 Z0
Z-0.2 F36
X2.833 F120
G0 Z5
X5.333 Y1.667
Z1
G1 Z0
Z-0.2 F36
X6.167 Y2.5 F120
X7.833
X8.667 Y1.667
Y0.833
X5.333 Y-2.5
X8.667
G0 Z5
X13.667 Y2.5
Z1
G1 Z0
Z-0.2 F36
X10.333 F120
Y0.833
X12.833
X13.667 Y0
Y-1.667
X12.833 Y-2.5
X10.333
G0 Z5
M9
M5
G53 G0 Z-2
M30
